byte field[4000];

void setup() {
  for (unsigned int i = 0; i < sizeof field; i++) field[i] = digitalRead(i % 14);
}

void loop() { digitalWrite(field[millis() % sizeof field] % 14, HIGH); }
