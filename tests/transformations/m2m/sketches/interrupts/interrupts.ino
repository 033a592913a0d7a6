volatile long turns;
const byte irq = 1;
void turn() { turns++; }
struct Encoder { byte intr; byte pin; };
Encoder encoders[2] = { {0, 4}, {1, 5} };
const int known = digitalPinToInterrupt(2);

void setup() {
  pinMode(3, INPUT);
  pinMode(2, INPUT); for (auto &each : encoders) attachInterrupt(each.intr, turn, RISING);
  attachInterrupt(irq, turn, RISING);
  attachInterrupt(known, turn, RISING);
  attachInterrupt(digitalPinToInterrupt(3), turn, RISING);
}

void loop() { detachInterrupt(0); }
