typedef int Angle;
int height;
Angle turned;
char side = -1;
void flip(char *way) { *way ^= 2; }
void setup() { Serial.begin(9600); while (!Serial && millis() < 3000) {} }
void loop() {
  char text[] = "12";
  sscanf(text, "%d", &height);
  height += 500;
  turned += 90;
  flip(&side);
  if (side < 0) tone(8, (uint16_t)(height + turned));
}
