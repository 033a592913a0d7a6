// Functions that end without the value that they promise.
bool started() {
  Serial.begin(9600); while (!Serial && millis() < 3000) {}  // says whether it could
return {}; }

int side(int n) {
  if (n > 3) return 1;
  else if (n < 0) return -1;
return {}; }

int sign(int n) {
  if (n < 0) {
    return -1;
  } else {
    return 1;
  }
}

int wait_for(int count) {
  while (true) {
    if (Serial.available() > count) return count;
  }
}

int drop() {
  for (;;) {
    if (Serial.read() < 0) break;
  }
return {}; }

char name_of(int n) {
  switch (n) {
    case 0: return 'a';
    case 1: return 'b';
    default: return 'c';
  }
}

String word_of(int n) {
  switch (n) {
    case 0: return "none";
    case 1: break;
    default: return "many";
  }
return {}; }

int &which(int *a) { *a = 1; }

void setup() {
  started();
}

void loop() {
  int n = side(wait_for(5)) + sign(drop());
  if (name_of(which(&n)) == 'a') word_of(n);
}
