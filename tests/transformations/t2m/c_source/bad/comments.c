/* only */ // comments

