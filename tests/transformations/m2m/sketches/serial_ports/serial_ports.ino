const int lamp = 2;
const int bell = 3;
void setup() {
  Serial1.begin(9600);
  pinMode(lamp, OUTPUT);
  pinMode(bell, OUTPUT);
}
void loop() {
  digitalWrite(lamp, Serial1.read());
  digitalWrite(bell, LOW);
}
