

#include <hardware/watchdog.h>
volatile unsigned long ticks = 0;

unsigned long now() {
  ATOMIC_BLOCK(ATOMIC_RESTORESTATE) {
    return ticks;
  }
  return 0;
}

void setup() {
  watchdog_enable(2000, true);
}

void loop() {
  unsigned long seen = 0;
  for (bool atomic = (noInterrupts(), true); atomic; interrupts(), atomic = false) {
    seen = ticks;
  }
  delay(10);
  delayMicroseconds(50);
  delayMicroseconds(1000.0 * (0.5));
  if (seen & bit(3)) watchdog_update();
}
