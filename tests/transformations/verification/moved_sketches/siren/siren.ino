// Beeps while a switch is closed.
const byte BUZZER = 8, SWITCH = 12;

void setup() {
  pinMode(SWITCH, INPUT_PULLUP);
}

void loop() {
  if (digitalRead(SWITCH) == LOW) {
    for (byte n = 0; n < 80; n++) {
      tone(BUZZER, 880);  // the wave goes on
      delay(2);
    }
    noTone(BUZZER);
    delay(160);
  } else {
    delay(10);
  }
}
