void setup() {
  pinMode(13, OUTPUT);
  pinMode(9, OUTPUT);
  pinMode(4, OUTPUT);
}

void loop() {
  digitalWrite(13, HIGH);
  digitalWrite(9, HIGH);
  [](uint8_t bits) { digitalWrite(4, bits >> 4 & 1); }(millis() << 4);
  byte levels = (digitalRead(26) | (digitalRead(27) << 1));
  if ((((digitalRead(6) << 6) | (digitalRead(7) << 7)) >> 6) == levels) digitalWrite(13, LOW);
  digitalWrite(9, HIGH);
  digitalWrite(13, (levels > 1) ? HIGH : LOW);
  if (digitalRead(2)) digitalWrite(13, !digitalRead(13));
  for (byte i = 0; i < 6; i++) PORTB |= 1 << i;
  digitalWrite(9, digitalRead(3));
  do {} while (digitalRead(3));
}
