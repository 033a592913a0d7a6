// Two motors with a whistle-free frequency of 31 kHz: timer 1 without its prescaler.
void setup() {
  pinMode(9, OUTPUT);
  pinMode(10, OUTPUT);
  TCCR1B = (TCCR1B & 0b11111000) | 0x01;
}

void loop() {
  analogWrite(9, 64);
  analogWrite(10, 192);
  delay(50);
  analogWrite(9, 192);
  analogWrite(10, 64);
  delay(50);
}
