#include <pico/time.h>
volatile byte count;

void begin() {



  static repeating_timer_t timer2; add_repeating_timer_us(-1000, [](repeating_timer_t *) { onTimer2(); return true; }, nullptr, &timer2);
}

void onTimer2() { count++; }

void setup() { begin(); }

void loop() {}
