// Waits in loops of several kinds: for the time, for a pin, for an interrupt, with and without calls and stores.
#include <hardware/gpio.h>
#include <hardware/timer.h>

volatile unsigned turns, edges;

void counted() { edges++; }

__attribute__((noinline)) bool later(unsigned long begun, unsigned long us) { return micros() - begun >= us; }

void setup() {
  Serial.begin(115200);
  pinMode(2, INPUT);
  pinMode(3, OUTPUT);
  pinMode(4, OUTPUT);
  attachInterrupt(digitalPinToInterrupt(2), counted, CHANGE);
}

void loop() {
  unsigned long begun = micros();
  while (micros() - begun < 137) {}
  digitalWrite(3, HIGH);
  begun = time_us_32();
  while (time_us_32() - begun < 7) {}
  digitalWrite(3, LOW);
  begun = micros();
  while (!later(begun, 211)) {}
  digitalWrite(3, HIGH);
  unsigned before = edges, rounds = 0;
  while (edges == before && rounds < 5000) rounds++;
  digitalWrite(3, LOW);
  begun = micros();
  while (digitalRead(2) && micros() - begun < 900) {}
  while (gpio_get_all() & 1u << 2) {}
  digitalWrite(4, HIGH);
  for (begun = micros(); micros() - begun < 50;) turns++;
  digitalWrite(4, LOW);
  if (millis() > 40) {
    Serial.print(edges);
    Serial.print(' ');
    Serial.println(turns);
  }
}
