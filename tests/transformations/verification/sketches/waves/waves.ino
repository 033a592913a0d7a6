// Waves of all three timers, of a tone, and none.
void setup() {
  analogWrite(5, 64);    // Timer0, fast
  analogWrite(9, 128);   // Timer1, phase correct
  analogWrite(3, 200);   // Timer2, phase correct
  delay(20);
  analogWrite(9, 0);     // ends the wave
  tone(8, 1000);         // Timer2 belongs to the tone now
}

void loop() {}
