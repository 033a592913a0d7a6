// A button at interrupt 1 toggles a lamp.
volatile boolean lit = false;

void toggle() { lit = !lit; }

void setup() {
  pinMode(3, INPUT_PULLUP);
  pinMode(10, OUTPUT);
  attachInterrupt(1, toggle, FALLING);
}

void loop() {
  digitalWrite(10, lit);
  delay(2);
}
