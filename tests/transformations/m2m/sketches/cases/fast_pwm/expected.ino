// A dimmed lamp at OC2B by registers: fast PWM with 8 bits.
void setup() { analogWriteFreq(977);
  pinMode(3, OUTPUT);


  analogWrite(3, 63);
}

void loop() {
  analogWrite(3, 63);
  delay(60);
  analogWrite(3, 191);
  delay(60);
}
