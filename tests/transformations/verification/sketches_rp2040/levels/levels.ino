// A pin is driven high, let go, pulled up, driven low; others follow an input, an input with a pull-up, and a voltage.
void setup() {
  pinMode(8, OUTPUT);
  digitalWrite(8, HIGH);
  delay(10);
  pinMode(8, INPUT);
  delay(10);
  pinMode(8, INPUT_PULLUP);
  delay(10);
  pinMode(8, OUTPUT);
  for (int pin = 11; pin <= 13; pin++) pinMode(pin, OUTPUT);
  pinMode(2, INPUT);
  pinMode(4, INPUT_PULLUP);
}

void loop() {
  digitalWrite(13, digitalRead(2));
  digitalWrite(12, digitalRead(4));
  digitalWrite(11, analogRead(A1) > 700);
}
