// Uses names that other C libraries have.
unsigned long time = 0;
int index = 0;
int alarm = 3;

void panic() { digitalWrite(2, HIGH); }

void setup() {
  pinMode(2, OUTPUT);
}

void loop() {
  time = millis();
  index++;
  if (index % alarm == 0) panic();
  else digitalWrite(2, LOW);
  delay(20);
}
