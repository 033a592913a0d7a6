#define LED 13

void setup() {}

void loop() { digitalWrite(LED, HIGH); }
