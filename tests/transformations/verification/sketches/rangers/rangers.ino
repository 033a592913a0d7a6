// A ranger with one pin and one with two, asked every 50 ms.
void setup() {
  Serial.begin(115200);
  pinMode(6, OUTPUT);
}

void loop() {
  digitalWrite(7, LOW);
  pinMode(7, OUTPUT);
  digitalWrite(7, HIGH);
  delayMicroseconds(5);
  digitalWrite(7, LOW);
  pinMode(7, INPUT);
  unsigned long one = pulseIn(7, HIGH, 20000);
  digitalWrite(6, HIGH);
  delayMicroseconds(10);
  digitalWrite(6, LOW);
  unsigned long two = pulseIn(5, HIGH, 20000);
  Serial.print((one + 29) / 58);
  Serial.print(' ');
  Serial.println((two + 29) / 58);
  delay(50);
}
