// A lamp follows the upper half of a phase that starts again at 65536.
unsigned int phase = 0;
int tune = 9000;

void setup() {
  pinMode(4, OUTPUT);
}

void loop() {
  phase += tune;
  digitalWrite(4, phase >= 32768u);
  delay(10);
}
