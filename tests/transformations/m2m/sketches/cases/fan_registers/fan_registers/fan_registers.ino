int speed = 0;
void setup() {
  pinMode(9, OUTPUT);
  pinMode(10, OUTPUT);
  TCCR1A = 0;
  TCCR1B = 0;
  TCNT1 = 0;
  TCCR1A = (1 << COM1A1) | (1 << COM1B1) | (1 << WGM11);
  TCCR1B = (1 << WGM13) | (1 << CS10);
  ICR1 = 320;
  OCR1B = 160;
}
void loop() {
  OCR1A = speed;
  speed = (speed + 10) % 320;
  delay(10);
}
