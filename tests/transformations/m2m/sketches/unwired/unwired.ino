const int horn = 40;
const int bell = 41;
void setup() {
  pinMode(horn, OUTPUT);
  pinMode(bell, OUTPUT);
}
void loop() {
  digitalWrite(horn, LOW);
  delay(10);
}
