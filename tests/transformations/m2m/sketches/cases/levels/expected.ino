const int RELAYS[] = {5, 6};

void off() { digitalWrite(7, HIGH); }

void setup() {
  pinMode(2, INPUT);
  pinMode(2, INPUT_PULLUP);
  for (int i = 0; i < 2; i++) digitalWrite(RELAYS[i], HIGH);
  for (int i = 0; i < 2; i++) [](int pin) { pinMode(pin, OUTPUT); digitalWrite(pin, HIGH); }(RELAYS[i]);
  off();
  [](int pin) { pinMode(pin, OUTPUT); digitalWrite(pin, HIGH); }(7);
  digitalWrite(8, LOW);
  pinMode(8, OUTPUT);
  pinMode(9, OUTPUT);
  digitalWrite(9, HIGH);
}

void loop() {
  digitalWrite(9, digitalRead(2));
  pinMode(10, OUTPUT);
  digitalWrite(10, LOW);
  delay(1);
  pinMode(10, INPUT);
  pinMode(10, INPUT_PULLUP);
  pinMode(2, INPUT);
  digitalWrite(3, digitalRead(10));
}
