const int FAN = 9;
const int PUMP = 5;
void setup() {
  pinMode(FAN, OUTPUT);
  pinMode(PUMP, OUTPUT);
}
void loop() {
  analogWrite(FAN, 100);
  analogWrite(PUMP, 100);
}
