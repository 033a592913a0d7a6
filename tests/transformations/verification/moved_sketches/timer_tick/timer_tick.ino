// A lamp blinks by the interrupt of timer 1, every 25 ms.
volatile bool lit = false;

ISR(TIMER1_COMPA_vect) {
  lit = !lit;
  digitalWrite(7, lit);
}

void setup() {
  pinMode(7, OUTPUT);
  noInterrupts();
  TCCR1A = 0;
  TCCR1B = 0;
  TCNT1 = 0;
  OCR1A = 6249;
  TCCR1B |= (1 << WGM12) | (1 << CS11) | (1 << CS10);
  TIMSK1 |= (1 << OCIE1A);
  interrupts();
}

void loop() {}
