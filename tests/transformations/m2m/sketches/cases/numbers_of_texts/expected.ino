void setup() {
  Serial.begin(9600); while (!Serial && millis() < 3000) {}
}

void loop() {
  String text = Serial.readString();
  int16_t sent = Serial.parseInt();
  int16_t said = text.toInt();
  int16_t typed = atol(text.c_str());
  int16_t wrapped = atoi(text.c_str());
  long kept = Serial.parseInt();
  Serial.println((int16_t)(sent * 2));
  Serial.println(said);
  Serial.println(typed);
  Serial.println(wrapped);
  Serial.println(kept);
}
