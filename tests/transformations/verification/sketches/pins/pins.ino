// A pin is driven high, let go, pulled up, driven low; another follows an input and a voltage.
void setup() {
  pinMode(8, OUTPUT);
  digitalWrite(8, HIGH);
  delay(10);
  pinMode(8, INPUT);
  delay(10);
  pinMode(8, INPUT_PULLUP);
  delay(10);
  digitalWrite(8, LOW);
  pinMode(8, OUTPUT);
  pinMode(13, OUTPUT);
  pinMode(4, INPUT_PULLUP);
}

void loop() {
  digitalWrite(13, digitalRead(2));
  digitalWrite(12, digitalRead(4));
  pinMode(12, OUTPUT);
  digitalWrite(11, analogRead(A1) > 700);
  pinMode(11, OUTPUT);
}
