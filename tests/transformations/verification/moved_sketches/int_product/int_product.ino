// A product that leaves 16 bits on the old board.
int speed = 300;
int turns = 200;

void setup() {
  Serial.begin(9600);
  pinMode(4, OUTPUT);
}

void loop() {
  int way = speed * turns;
  Serial.println(way);
  digitalWrite(4, way < 0);
  turns = turns == 200 ? 100 : 200;
  delay(60);
}
