// An active-low relay stays off: its level is written before its mode.
void setup() {
  digitalWrite(6, HIGH);
  pinMode(6, OUTPUT);
  delay(100);
  digitalWrite(6, LOW);
}
void loop() { delay(100); digitalWrite(6, !digitalRead(6)); }
