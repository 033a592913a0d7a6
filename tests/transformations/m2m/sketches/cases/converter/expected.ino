int level;

void setup() {


}

void loop() {


  level = analogRead(28);
  delay(level / 4);
}
