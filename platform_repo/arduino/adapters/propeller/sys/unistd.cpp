//# header sys/unistd.h
// Waiting, and folders of a card. Read from propgcc b280e7a77, lib/include/sys/unistd.h, lib/time/sleep.c and usleep.c, lib/misc/rmdir.c.
// avr-libc has none of them.
//# task chdir the library of the card has no current folder: write the folder into the names that the program opens
//# task getcwd the library of the card has no current folder: take the name that the program would have given to chdir

//# type useconds_t
//#   fidelity: exact
typedef uint32_t useconds_t;

//# adapter sleep
//#   for: unsigned int sleep(unsigned int seconds)
//#   kind: oneToMany
//#   fidelity: within 0.1 %; the answer is 0
//#   stack: 12 2
inline uint32_t sleep(uint32_t seconds) {
  for (; seconds; seconds--) delay(1000);
  return 0;
}

//# adapter usleep
//#   for: int usleep(useconds_t usec)
//#   kind: semantic
//#   fidelity: within 8 us; the answer is 0
//#   stack: 2
inline int32_t usleep(uint32_t usec) {
  for (uint32_t begun = micros(); micros() - begun < usec;) yield();
  return 0;
}

//# adapter rmdir
//#   for: int rmdir(const char *path)
//#   kind: oneToOne
//#   include: <SD.h>
//#   library: SD
//#   fidelity: exact: 0, or -1 where it is no folder or not empty
//#   stack: 0
inline int32_t rmdir(const char *path) {
  return SD.rmdir(path) ? 0 : -1;
}
