void setup() {
  pinMode(4, OUTPUT);
}

void loop() {
  asm volatile("nop");
  digitalWrite(4, LOW);
}
