int look(int pin);
