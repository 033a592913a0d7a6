// Beeps while a switch is closed.
const byte BUZZER = 8, SWITCH = 12;

void setup() {
  pinMode(SWITCH, INPUT_PULLUP);
}

void loop() {
  if (digitalRead(SWITCH) == LOW) {
    tone(BUZZER, 880);
    delay(160);
    noTone(BUZZER);
    delay(160);
  } else {
    delay(10);
  }
}
