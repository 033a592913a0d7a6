

void setup() {
  pinMode(12, OUTPUT), pinMode(13, OUTPUT);
  pinMode(2, INPUT);
  pinMode(2, INPUT_PULLUP);
}

void loop() {
  if (digitalRead(2)) digitalWrite(12, HIGH);
  else digitalWrite(12, LOW);
  digitalWrite(13, !digitalRead(13));
  digitalWrite(13, !digitalRead(13));
  delay(100);
}
