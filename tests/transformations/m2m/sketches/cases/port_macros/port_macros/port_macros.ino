// Names of a program's own for registers.
#define LIGHTS PORTB
#define LIGHTS_MODE DDRB
#define LAMPS LIGHTS
#define SET(port, bit) ((port) |= _BV(bit))
#define GREEN_ON (PORTC |= _BV(2))
#define WATCH TCNT1

void setup() {
  LIGHTS_MODE |= 0x0F;
  DDRC |= _BV(2);
  SET(DDRD, 7);
}

void loop() {
  LAMPS |= 0x01;
  LIGHTS &= ~0x0F;
  GREEN_ON;
  SET(PORTD, 7);
  delay(WATCH & 7);
}
