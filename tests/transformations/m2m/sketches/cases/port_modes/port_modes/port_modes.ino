void setup() {
  pinMode(13, OUTPUT);
  pinMode(9, OUTPUT);
  pinMode(4, OUTPUT);
}

void loop() {
  PORTB |= _BV(5);
  PORTB = (PORTB & 0xFD) | 2;
  PORTD = millis() << 4;
  byte levels = PINC & 3;
  if ((PIND >> 6) == levels) PORTB &= ~(1 << 5);
  bitSet(PORTB, 1);
  bitWrite(PORTB, 5, levels > 1);
  if (bitRead(PIND, 2)) PORTB ^= 0x20;
  for (byte i = 0; i < 6; i++) PORTB |= 1 << i;
  digitalWrite(9, bit_is_set(PIND, 3));
  loop_until_bit_is_clear(PIND, 3);
}
