signed char direction = -1;
const signed char moves[] = {-1, 0, 1};
char letter = 'a';
char name[] = "robot";
signed char turned(signed char by) { return -by; }

signed char found(char wanted) {
  for (char i = 0; i < 5; i++)
    if (name[i] == wanted) return i;
  return -1;
}

void setup() {}

void loop() {
  char key = 0;
  if (found('x') < 0) key = letter;
  direction = turned(-2);
  if (key == 'a') direction = -direction + moves[1];
}
