void setup() {
  // Assembler (asm) of another processor.
  __asm__ volatile("mov r0, #1");
}

void loop() {}
