// A button against ground; its pull-up is switched on by a write.
void setup() {
  pinMode(4, INPUT);
  digitalWrite(4, HIGH);
  pinMode(9, OUTPUT);
}
void loop() {
  digitalWrite(9, digitalRead(4) == LOW ? HIGH : LOW);
  delay(5);
}
