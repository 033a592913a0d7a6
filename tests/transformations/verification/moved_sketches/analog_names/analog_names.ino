// Analogue pins by channel, as digital outputs and by their numbers.
void setup() {
  pinMode(A3, OUTPUT);
  pinMode(15, OUTPUT);
}

void loop() {
  int light = analogRead(0);
  digitalWrite(A3, light > 300);
  digitalWrite(15, light < 600);
  delay(10);
}
