#include <util/delay.h>
#include <util/atomic.h>
#include <avr/wdt.h>
volatile unsigned long ticks = 0;

unsigned long now() {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    return ticks;
  }
  return 0;
}

void setup() {
  wdt_enable(WDTO_2S);
}

void loop() {
  unsigned long seen = 0;
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    seen = ticks;
  }
  _delay_ms(10);
  _delay_us(50);
  _delay_ms(0.5);
  if (seen & _BV(3)) wdt_reset();
}
