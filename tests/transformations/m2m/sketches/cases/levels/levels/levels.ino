const int RELAYS[] = {5, 6};

void off() { digitalWrite(7, HIGH); }

void setup() {
  pinMode(2, INPUT);
  digitalWrite(2, HIGH);
  for (int i = 0; i < 2; i++) digitalWrite(RELAYS[i], HIGH);
  for (int i = 0; i < 2; i++) pinMode(RELAYS[i], OUTPUT);
  off();
  pinMode(7, OUTPUT);
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
  digitalWrite(10, HIGH);
  digitalWrite(2, LOW);
  digitalWrite(3, digitalRead(10));
}
