void setup() {
  DDRB |= 1 << 5;
  DDRD |= 1 << 4; /* PORTB */
}
void loop() {
  PORTB |= 1 << 5; PORTD += 3;
  PORTB &= ~(1 << 5); PORTD |= 1 << 4; // PORTC
  if (PIND & 4) PORTC = PINC + 1;
  Serial.println("http://"); PORTD += 1; /* PORTB */
  delay(100);
}
