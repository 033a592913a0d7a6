const int FAN = 9;
const int PUMP = 5;
void setup() { analogWriteFreq(490);
  pinMode(FAN, OUTPUT);
  pinMode(PUMP, OUTPUT);
}
void loop() {
  analogWrite(FAN, 100);
  analogWrite(PUMP, 100);
}
