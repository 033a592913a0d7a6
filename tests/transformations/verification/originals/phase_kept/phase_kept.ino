const int button = 2, lamp = 13;
int16_t phase = 0;

void step(int by) {
  if (digitalRead(button) == HIGH)
    phase += by;
  else
    phase -= by / 2;
}

void setup() {
  pinMode(button, INPUT);
  pinMode(lamp, OUTPUT);
}

void loop() {
  step(6000);
  digitalWrite(lamp, phase >= 0);
  delay(20);
}
