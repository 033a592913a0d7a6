// Names that the core of the other board has, too.
int D3 = 3;
float gamma = 2.2;
int y1, reverse;
unsigned long loop1() { return millis(); }
int select(int side) { return side + y1; }

void setup() {
  pinMode(D3, OUTPUT);
}

void loop() {
  int yn = 2;
  y1 = (int)(gamma * yn);
  reverse = !reverse;
  if (loop1() > 100UL && reverse) analogWrite(D3, select(y1));
}
