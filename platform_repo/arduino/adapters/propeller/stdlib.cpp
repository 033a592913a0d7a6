//# header stdlib.h
// The end of a program. Read from propgcc b280e7a77, lib/include/stdlib.h and lib/stdlib/exit.c. All else of the header is that of
// avr-libc, whose exit turns interrupts off, so that text that is on its way gets lost and servos, tones and jobs stand still.

//# adapter exit
//#   for: void exit(int status)
//#   kind: semantic
//#   name: c_exit
//#   fidelity: the program rests for ever, while text on its way, servos and tones go on, as other cogs do there
//#   limit: functions given to atexit are not called, and nobody gets the status
//#   stack: 0
[[noreturn]] inline void c_exit(int32_t status) {
  (void)status;
  for (;;) yield();
}
