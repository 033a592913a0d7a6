void setup() {
  TCCR1A = bit(COM1A1) | bit(WGM11);
  TCCR1B = bit(WGM13) | bit(WGM12) | bit(CS11);
  ICR1 = 39999;
  pinMode(9, OUTPUT);
}

void loop() {
  OCR1A = OCR1A + 1;
}
