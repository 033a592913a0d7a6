// Says what it is, and then nothing more.
void setup() {
  Serial.begin(9600);
  Serial.println("gripper 1.2");
  pinMode(7, OUTPUT);
}

void loop() {
  digitalWrite(7, HIGH);
  delay(25);
  digitalWrite(7, LOW);
  delay(25);
}
