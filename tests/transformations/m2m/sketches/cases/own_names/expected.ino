// Names that the core of the other board has, too.
int D3_ = 3;
float gamma_ = 2.2;
int y1_, reverse_;
unsigned long loop1_() { return millis(); }
int select(int side) { return side + y1_; }

void setup() { analogWriteFreq(490);
  pinMode(D3_, OUTPUT);
}

void loop() {
  int yn = 2;
  y1_ = (int)(gamma_ * yn);
  reverse_ = !reverse_;
  if (loop1_() > 100UL && reverse_) analogWrite(D3_, select(y1_));
}
