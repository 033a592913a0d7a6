const int FAN = 9;
void setup() {
  pinMode(FAN, OUTPUT);
}
void loop() {
  analogWrite(FAN, 100);
}
