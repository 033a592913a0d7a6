int speed = 0;
void setup() { analogWriteFreq(25000);
  pinMode(9, OUTPUT);
  pinMode(10, OUTPUT);






  analogWrite(10, 128);
}
void loop() {
  analogWrite(9, 51UL * (speed) / 64);
  speed = (speed + 10) % 320;
  delay(10);
}
