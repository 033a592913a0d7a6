void turn(int degrees);
