volatile byte changes;

void onPinChange2() {
  changes++;
}

void setup() {

  attachInterrupt(digitalPinToInterrupt(4), onPinChange2, CHANGE), attachInterrupt(digitalPinToInterrupt(5), onPinChange2, CHANGE);
  pinMode(4, INPUT_PULLUP);
}

void loop() {
  if (changes > 10) changes = 0;
}
