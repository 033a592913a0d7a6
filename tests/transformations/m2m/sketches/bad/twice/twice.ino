void setup() {}
void loop() { beep(); }
void beep() { tone(8, 440); }
