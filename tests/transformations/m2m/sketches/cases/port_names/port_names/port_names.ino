#define LED PB5
#define KEY (1 << PD2)
#define LIGHTS PORTB

void setup() {
  DDRB |= 1 << LED;
  PORTD |= KEY;
}

void loop() {
  if (PIND & KEY) LIGHTS |= _BV(LED);
  else LIGHTS &= ~_BV(LED);
}
