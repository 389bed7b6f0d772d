"""Test definitions: what they may say, what they mean for the loop, and what they come to."""
