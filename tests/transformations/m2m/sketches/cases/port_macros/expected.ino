// Names of a program's own for registers.
#define LIGHTS PORTB
#define LIGHTS_MODE DDRB
#define LAMPS LIGHTS
#define SET(port, bit) ((port) |= _BV(bit))
#define GREEN_ON (PORTC |= _BV(2))
#define WATCH TCNT1

void setup() {
  pinMode(8, OUTPUT), pinMode(9, OUTPUT), pinMode(10, OUTPUT), pinMode(11, OUTPUT);
  pinMode(28, OUTPUT);
  pinMode(7, OUTPUT);
}

void loop() {
  digitalWrite(8, HIGH);
  digitalWrite(8, LOW), digitalWrite(9, LOW), digitalWrite(10, LOW), digitalWrite(11, LOW);
  GREEN_ON;
  digitalWrite(7, HIGH);
  delay(WATCH & 7);
}
