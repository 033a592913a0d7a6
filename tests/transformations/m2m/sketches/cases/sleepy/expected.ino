// Sleeps until somebody presses, then lights a lamp for a while.


volatile bool pressed = false;

void wake() { pressed = true; }

void setup() {
  pinMode(2, INPUT_PULLUP);
  pinMode(9, OUTPUT);
  attachInterrupt(digitalPinToInterrupt(2), wake, FALLING);

}

void loop() {

  delay(1);

  if (pressed) {
    pressed = false;
    digitalWrite(9, HIGH);
    delay(40);
    digitalWrite(9, LOW);
  }
}
