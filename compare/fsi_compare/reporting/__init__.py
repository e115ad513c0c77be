"""What people read: tables, pictures, the report; and the cost and pressure tables made of finished runs."""
