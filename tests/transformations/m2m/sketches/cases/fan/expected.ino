const int FAN = 9;
void setup() { analogWriteFreq(490);
  pinMode(FAN, OUTPUT);
}
void loop() {
  analogWrite(FAN, 100);
}
