void begin_wheels() {
  pinMode(LAMP, OUTPUT);
}
void turn(int way) {}
