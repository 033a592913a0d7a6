// A gate opens when the potentiometer is above two thirds.
int gate = 4;

void setup() {
  pinMode(gate, OUTPUT);
}

void loop() {
  int value = analogRead(A1);
  digitalWrite(gate, value > 682 ? HIGH : LOW);
  delay(10);
}
