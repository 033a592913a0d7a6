// What is typed comes back, one letter later in the alphabet.
void setup() {
  Serial.begin(115200);
  Serial.println("ready");
}

void loop() {
  if (Serial.available()) Serial.write(Serial.read() + 1);
}
