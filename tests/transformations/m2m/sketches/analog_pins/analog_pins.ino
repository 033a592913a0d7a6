int far = 21;
const int near = A6;

void setup() {
  Serial.begin(9600);
}

void loop() {
  Serial.println(analogRead(far));
  Serial.println(analogRead(7));
  Serial.println(analogRead(near));
  delay(100);
}
