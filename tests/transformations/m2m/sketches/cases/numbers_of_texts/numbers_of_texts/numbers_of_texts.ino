void setup() {
  Serial.begin(9600);
}

void loop() {
  String text = Serial.readString();
  int sent = Serial.parseInt();
  int said = text.toInt();
  int typed = atol(text.c_str());
  int wrapped = atoi(text.c_str());
  long kept = Serial.parseInt();
  Serial.println(sent * 2);
  Serial.println(said);
  Serial.println(typed);
  Serial.println(wrapped);
  Serial.println(kept);
}
