"""What a distributed run takes at sizes that no machine here holds, from tiles that are sampled."""
