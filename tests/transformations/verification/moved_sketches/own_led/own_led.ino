// The LED of the board, by number and by name.
int ledPin = 13;

void setup() {
  pinMode(ledPin, OUTPUT);
}

void loop() {
  digitalWrite(ledPin, HIGH);
  delay(30);
  digitalWrite(LED_BUILTIN, LOW);
  delay(50);
}
