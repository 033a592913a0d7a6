// Counts edges by an interrupt, and calls a job each 5 ms.
#include <pico/time.h>

volatile unsigned edges;
repeating_timer_t timer;

bool tick(repeating_timer_t *) {
  digitalWrite(3, !digitalRead(3));
  return true;
}

void setup() {
  pinMode(3, OUTPUT);
  pinMode(2, INPUT_PULLUP);
  attachInterrupt(digitalPinToInterrupt(2), []() { edges++; }, FALLING);
  add_repeating_timer_us(-5000, tick, nullptr, &timer);
  Serial.begin(115200);
  delay(150);
  Serial.println(edges);
}

void loop() {}
