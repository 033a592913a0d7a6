#include <pico/time.h>


volatile unsigned long ticks = 0;

void onTimer1() {
  ticks++;
}

void setup() {
  noInterrupts();






  static repeating_timer_t timer1; add_repeating_timer_us(-1000000, [](repeating_timer_t *) { onTimer1(); return true; }, nullptr, &timer1);
  interrupts();
}

void loop() {
  noInterrupts();
  unsigned long now = ticks;
  interrupts();
  if (now > 10) delay(1);
}
