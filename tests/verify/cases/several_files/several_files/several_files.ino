void step();

void setup() {}

void loop() { step(); }
