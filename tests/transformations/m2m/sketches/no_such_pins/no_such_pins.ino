int lamp = 21;

void setup() {
  pinMode(lamp, OUTPUT);
  pinMode(22, OUTPUT);
}

void loop() {
  digitalWrite(lamp, HIGH);
  digitalWrite(22, analogRead(25) > 500);
  delay(100);
}
