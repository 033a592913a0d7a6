// Two line sensors, two motors with analogWrite.
const int LEFT_SENSOR = 2, RIGHT_SENSOR = 4;
const int LEFT_MOTOR = 5, RIGHT_MOTOR = 6;

void drive(int left, int right) {
  analogWrite(LEFT_MOTOR, left);
  analogWrite(RIGHT_MOTOR, right);
}

void setup() {
  pinMode(LEFT_SENSOR, INPUT);
  pinMode(RIGHT_SENSOR, INPUT);
}

void loop() {
  bool l = digitalRead(LEFT_SENSOR), r = digitalRead(RIGHT_SENSOR);
  if (l && r) drive(200, 200);
  else if (l) drive(60, 200);
  else if (r) drive(200, 60);
  else drive(0, 0);
  delay(20);
}
