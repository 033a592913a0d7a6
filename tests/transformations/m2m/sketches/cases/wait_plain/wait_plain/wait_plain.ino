void setup() {
  Serial.begin(9600);
  while (!Serial);
  Serial.println("ready");
}
void loop() {}
