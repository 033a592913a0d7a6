// Charges a capacitor, lets go and counts; the second time with the pull-up left on.
unsigned long decay(int pin, int mode) {
  pinMode(pin, OUTPUT);
  digitalWrite(pin, HIGH);
  delay(1);
  if (mode == INPUT) digitalWrite(pin, LOW), pinMode(pin, INPUT), digitalWrite(pin, LOW);
  else pinMode(pin, mode);
  unsigned long begun = micros();
  while (digitalRead(pin) && micros() - begun < 5000) {}
  return micros() - begun;
}

void setup() {
  Serial.begin(115200);
  DDRD |= _BV(4);
  PORTD |= _BV(4);
  delay(1);
  DDRD &= ~_BV(4);
  PORTD &= ~_BV(4);
  unsigned long begun = micros();
  while (PIND & _BV(4)) {}
  Serial.println((micros() - begun + 50) / 100);
  Serial.println(decay(4, INPUT_PULLUP) >= 5000);
}

void loop() {}
